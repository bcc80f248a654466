# Removes, renames and shuts its own folder.
# Must: x refused
# %%
here = os.getcwd()
x = [attempt(lambda: os.rmdir(here)), attempt(lambda: os.rename(here, here + "2")), attempt(lambda: os.chmod(here, 0))]
