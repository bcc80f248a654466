# Sets the clock, the host's name, and turns the machine off.
# Must: x refused
# %%
import time
x = [
    attempt(lambda: time.clock_settime(time.CLOCK_REALTIME, 0)), attempt(lambda: call("sethostname", b"a", 1)),
    attempt(lambda: call("reboot", 0x1234567)), attempt(lambda: call("swapoff", b"/dev/sda")),
    attempt(lambda: call("klogctl", 3, 0, 0)), attempt(lambda: call("acct", 0)),
]
