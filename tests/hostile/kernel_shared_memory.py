# Makes shared memory, message queues and semaphores that outlive it.
# Must: x refused
# %%
from multiprocessing import shared_memory
x = [
    attempt(lambda: call("shmget", 0x7A11, 4096, 0o1666)), attempt(lambda: call("semget", 0x7A11, 1, 0o1666)),
    attempt(lambda: call("msgget", 0x7A11, 0o1666)), attempt(lambda: call("mq_open", b"a", 0o102, 0o666, 0)),
    attempt(lambda: shared_memory.SharedMemory("hostile-was-here", create=True, size=10)),
]
