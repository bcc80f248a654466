# Makes a file in memory, to start it as a program.
# Must: x refused
# %%
x = [
    attempt(lambda: os.memfd_create("program")), attempt(lambda: call("memfd_secret", 0)),
    attempt(lambda: call("execveat", 3, b"", 0, 0, 0x1000)), attempt(lambda: os.execve(sys.executable, ["python"], {})),
]
