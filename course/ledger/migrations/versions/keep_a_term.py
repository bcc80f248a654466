"""What a term brings: times of receipt, extensions, what is accepted, requests, published marks."""

import sqlalchemy as sa
from alembic import op

revision = "3"
down_revision = "2"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Adds tables, and the ticked lines of a rubric to marks."""
    op.add_column("mark", sa.Column("ticks", sa.String, nullable=False, server_default=""))
    _create(
        "arrival",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("hash", sa.String, primary_key=True),
        sa.Column("at", sa.String, nullable=False),
    )
    _create(
        "extension",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("until", sa.String),
        sa.Column("excused", sa.Boolean, nullable=False),
    )
    _create(
        "acceptance",
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("part", sa.String, primary_key=True),
        sa.Column("kind", sa.String, nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("share", sa.Float),
    )
    _create(
        "request",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("part", sa.String, primary_key=True),
        sa.Column("text", sa.Text, nullable=False),
    )
    _create(
        "published",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("result", sa.Text, nullable=False),
    )


def _create(name: str, *columns: "sa.Column[object]") -> None:
    """A table whose rows belong to an entry, and are looked for by sheet and student."""
    entry = sa.Column("entry", sa.Integer, sa.ForeignKey("entry.id"), primary_key=True)
    op.create_table(name, entry, *columns)
    looked_up = ["sheet"]
    if any(column.name == "student" for column in columns):
        looked_up.append("student")
    op.create_index(f"{name}_sheet", name, looked_up)
