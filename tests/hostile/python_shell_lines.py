# Runs shell lines and shell cells by Jupyter's magics.
# Must: x is 0; y is 2
# %%
!touch {COURSE}/{MARK}
found = !cat {COURSE}/secret
reach()
x = len(found)
# %%
%%bash
touch /tmp/hostile-was-here
# %%
%system touch /tmp/hostile-was-here
# %%
%sx touch /tmp/hostile-was-here
# %%
y = 2
