"""What students run: the check of their own file, and variants to practise on."""
