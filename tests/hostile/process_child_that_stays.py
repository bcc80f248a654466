# Starts a child in a session of its own that stays and waits.
# Must: x refused
# %%
import subprocess, time
def stay():
    if os.fork() == 0:
        os.setsid()
        time.sleep(1000)
x = [attempt(stay), attempt(lambda: subprocess.Popen(["sleep", "1000"], start_new_session=True)), attempt(os.setsid)]
