# Opens raw, packet, netlink, Bluetooth, virtual machine and kernel crypto sockets.
# Must: x refused
# %%
import socket
x = [attempt(lambda: socket.socket(family, kind)) for family, kind in ((2, 3), (17, 3), (16, 3), (31, 3), (40, 1), (38, 5))]
