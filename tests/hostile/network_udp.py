# Sends answers away by UDP.
# Must: x refused
# %%
import socket
def send():
    socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b"answers", ("127.0.0.1", UDP))
x = attempt(send)
