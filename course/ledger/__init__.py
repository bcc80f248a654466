"""Where a gradebook's rows lie: tables, the database that holds them, its earlier formats."""
