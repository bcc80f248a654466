"""Ways from an earlier gradebook to that of today, as Alembic reads them."""
