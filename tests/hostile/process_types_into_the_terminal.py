# Types a command into the terminal of the person who marks.
# Must: x refused
# %%
import fcntl
def type_into(number):
    for letter in b"touch /tmp/hostile-was-here\n": fcntl.ioctl(number, 0x5412, bytes([letter]))
x = [attempt(lambda: type_into(number)) for number in range(3)]
x.append(attempt(lambda: open("/dev/tty", "w")))
