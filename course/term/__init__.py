"""What a term brings to marks: people's decisions, deadlines, attempts, publication."""
