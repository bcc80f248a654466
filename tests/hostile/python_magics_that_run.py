# Runs and writes files by magics, out of its folder.
# Must: x lost: cell 2 stopped with *Error: [Errno *] *: '…/lever.py'; f lost: cell 3 stopped with *Error: [Errno *] *: '…/hostile-was-here.py'; y is 2
# %%
reach()
x = get_ipython().run_line_magic("run", f"{COURSE}/solutions/lever.py")
# %%
f = get_ipython().run_cell_magic("writefile", f"{COURSE}/exercises/{MARK}.py", "1")
# %%
y = 2
