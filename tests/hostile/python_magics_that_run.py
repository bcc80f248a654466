# Runs and writes files by magics, out of its folder.
# Must: x lost; y is 2
# %%
x = get_ipython().run_line_magic("run", f"{COURSE}/solutions/lever.py")
# %%
get_ipython().run_cell_magic("writefile", f"{COURSE}/exercises/{MARK}.py", "1")
# %%
y = 2
