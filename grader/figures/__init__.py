"""Pictures of arms and maps of robots; nothing in here knows of marking."""
