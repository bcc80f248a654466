# Connects one end of a pair of sockets to somebody else, and sends by address.
# Must: x refused
# %%
import socket
one, two = socket.socketpair()
some, more = socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
x = [
    attempt(lambda: one.connect(DOOR)), attempt(lambda: some.sendto(b"a", DOOR)),
    attempt(lambda: some.sendto(b"a", ABSTRACT)), attempt(lambda: some.bind("\0mine")),
    attempt(lambda: some.sendmsg([b"a"], [], 0, ABSTRACT)), attempt(lambda: some.connect(ABSTRACT)),
]
