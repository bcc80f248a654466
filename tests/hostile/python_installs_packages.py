# Installs packages by pip, as a magic, a module, and a shell line.
# Must: x refused: ImportError; y is 2
# %%
%pip install requests
!pip install requests
import runpy
x = attempt(lambda: runpy.run_module("pip", run_name="__main__"))
y = 2
