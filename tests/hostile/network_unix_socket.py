# Connects to a socket that is a file, and to abstract ones, such as those of a desktop.
# Must: x refused
# %%
import socket
def connect(address):
    socket.socket(socket.AF_UNIX).connect(address)
x = [attempt(lambda: connect(address)) for address in (DOOR, ABSTRACT, "/run/dbus/system_bus_socket", "/var/run/docker.sock")]
