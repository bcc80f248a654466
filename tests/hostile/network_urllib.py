# Fetches a page, and a file by its address.
# Must: x lost; y lost
# %%
import urllib.request
x = urllib.request.urlopen(f"http://127.0.0.1:{TCP}/", timeout=1).status
# %%
y = len(urllib.request.urlopen(f"file://{COURSE}/secret").read())
