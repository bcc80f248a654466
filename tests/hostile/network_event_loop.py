# Connects by an event loop, in a cell that awaits.
# Must: x lost: cell 3 stopped with PermissionError: [Errno 1] Operation not permitted
# %%
import asyncio
await asyncio.sleep(0)
reach()
# %%
reader, writer = await asyncio.open_connection("127.0.0.1", TCP)
x = 1
