# Asks for the address of a name, so that an answer goes out as a question.
# Must: y lost: cell 2 stopped with gaierror: *
# %%
import socket
reach()
y = socket.getaddrinfo("answers.example.org", 80)
