# Writes to every folder where programs usually may.
# Must: x refused
# %%
folders = ("/tmp", "/var/tmp", "/dev/shm", "/run", "/", "/root", "/home", os.path.dirname(os.getcwd()) or "/")
x = [attempt(lambda: open(f"{folder}/{MARK}", "w")) for folder in folders]
