# Puts a program into its folder and makes it one that can be started.
# Must: x refused
# %%
with open("program", "w") as file: file.write("#!/bin/sh\ntouch here")
x = [attempt(lambda: os.chmod("program", 0o4755)), attempt(lambda: os.execv("./program", ["program"]))]
