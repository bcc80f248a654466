# Starts programs by subprocess, os.system, popen and posix_spawn.
# Must: x refused; y is 0
# %%
import subprocess
x = [
    attempt(lambda: subprocess.run(["/bin/true"])), attempt(lambda: subprocess.run("true", shell=True)),
    attempt(lambda: os.posix_spawn("/bin/true", ["true"], {})), attempt(lambda: os.popen("true").read()),
    attempt(lambda: os.execv("/bin/true", ["true"])), attempt(lambda: os.spawnl(os.P_NOWAIT, "/bin/true", "true")),
]
y = int(os.system("true") == 0)
