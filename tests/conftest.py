"""Fixtures that several test files share."""

import pytest
from answers import EXERCISES, SLUGS


@pytest.fixture(params=SLUGS)
def exercise(request):
    """Every exercise file, ours today and those to come."""
    return EXERCISES[request.param]
