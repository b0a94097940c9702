import matplotlib
import pytest

from barchan.figures import style

matplotlib.use("Agg")


@pytest.fixture(autouse=True)
def look():
    with style.look():
        yield
