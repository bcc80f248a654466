# Asks for the address of a name, so that an answer goes out as a question.
# Must: y lost
# %%
import socket
y = socket.getaddrinfo("answers.example.org", 80)
