"""Proof that exercises can be solved, marked and told apart from their known mistakes."""
