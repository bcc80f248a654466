# Changes the time zone, the locale and the environment.
# Must: x is 1
# %%
import locale, time
os.environ.update(TZ="Mars/Olympus", LANG="tr_TR", LC_ALL="C", PYTHONSTARTUP="/x", LD_PRELOAD="/x", HOME="/")
time.tzset()
try: locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
except locale.Error: pass
reach()
x = 1
