# Makes files without end in a folder that nobody may list.
# Must: x lost: the notebook wrote more files than a sheet asks for
# Seconds: 30
# Cell seconds: 20
# %%
os.mkdir("hidden", 0o300)
os.chdir("hidden")
reach()
# %%
i = 0
while True:
    try: open(f"{i}", "w").close()
    except OSError: break
    i += 1
