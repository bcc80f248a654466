# Connects by an event loop, in a cell that awaits.
# Must: x lost
# %%
import asyncio
reader, writer = await asyncio.open_connection("127.0.0.1", TCP)
x = 1
