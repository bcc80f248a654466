"""What students read, in the language of their sheet: catalogues, and the sentences in them."""
