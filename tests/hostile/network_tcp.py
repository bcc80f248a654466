# Connects to a server on this machine and to one elsewhere.
# Must: x refused
# %%
import socket
x = [attempt(lambda: socket.create_connection((host, TCP), timeout=1)) for host in ("127.0.0.1", "::1", "192.0.2.1")]
