# Imports the grader's own packages and reads their files.
# Must: x refused: ModuleNotFoundError
# %%
import importlib
names = ("kinegrade", "kinegrade.solutions.jacobian", "sqlalchemy", "pytest", "alembic")
x = [attempt(lambda: importlib.import_module(name)) for name in names]
sys.path += [SITE, os.path.dirname(os.path.dirname(ENGINE))]
x.append(attempt(lambda: importlib.import_module("kinegrade.grader.collecting.collect")))
x.append(attempt(lambda: os.listdir(SITE)))
