# Hands in text with terminal sequences, a NUL, and characters that turn the line round.
# Must: y is 1
# %%
x = "\x1b]0;owned\x07\x1b[2J\x00\u202e\ud800<script>alert(1)</script>"
reach()
y = 1
