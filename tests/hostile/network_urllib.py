# Fetches a page, and a file by its address.
# Must: x lost: cell 2 stopped with URLError: <urlopen error [Errno 1] Operation not permitted>; y lost: cell 3 stopped with URLError: <urlopen error [Errno *] *: '…/secret'>
# %%
import mimetypes, urllib.request
mimetypes.knownfiles.clear()
reach()
x = urllib.request.urlopen(f"http://127.0.0.1:{TCP}/", timeout=1).status
# %%
y = len(urllib.request.urlopen(f"file://{COURSE}/secret").read())
