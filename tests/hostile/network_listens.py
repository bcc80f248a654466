# Waits for connections on a port.
# Must: x refused
# %%
import socket
x = attempt(lambda: socket.create_server(("0.0.0.0", 0)))
