# Turns warnings and numpy's floating point signals into errors, and changes how numbers are printed.
# Must: x is [1.0, 2.0]; y is '0.1*q1'
# %%
import warnings, sympy
warnings.simplefilter("error")
np.seterr(all="raise")
np.set_printoptions(precision=1, threshold=0)
sympy.init_printing()
reach()
x, y = [1.0, 2.0], 0.1 * sympy.Symbol("q1")
