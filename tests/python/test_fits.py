"""Lines through ensembles: exact ones, and made-up ones whose exponents and scatter are known."""

import numpy as np
import pytest

from barchan.dune.fits import fit

CASES, RUNS, N = 4, 4, -1.2
NAMES = np.repeat([f"case {i}" for i in range(CASES)], RUNS)


def ensemble(seed, along, up):
    """(x, y) of a power N over a factor of three, each run with its own scatter of both."""
    random = np.random.default_rng(seed)
    x = np.repeat(np.geomspace(8e-3, 24e-3, CASES), RUNS)
    return (values * np.exp(noise * random.standard_normal(CASES * RUNS)) for values, noise in
            ((x, along), (1e-5 * x**N, up)))


@pytest.fixture(scope="module")
def many():
    """The laws of 200 ensembles with 5 % of scatter along x and 15 % of y."""
    return [fit(*ensemble(seed, 0.05, 0.15), "power", NAMES) for seed in range(200)]


def test_nineteen_of_twenty_exponents_lie_within_two_of_their_errors(many):
    """With 14 degrees of freedom 93.5 % should: 187 of 200, with a standard deviation of 3.5. Errors that are wrong by
    a third would make it 81 or 99 %. The 95 % intervals hold N as often as they say."""
    near = np.array([abs(law.n - N) for law in many])
    assert 0.88 <= np.mean(near < 2 * np.array([law.error for law in many])) <= 0.98
    assert 0.90 <= np.mean([law.holds(N) for law in many]) <= 0.985


def test_the_errors_are_the_spread_of_the_exponents(many):
    assert np.sqrt(np.mean([law.error**2 for law in many])) == pytest.approx(np.std([law.n for law in many]), rel=0.15)


def test_scatter_along_x_does_not_flatten_the_line():
    """A quarter of it along x: through single runs the line is flatter by a third, through the means by a tenth."""
    def mean(cases):
        return np.mean([fit(*ensemble(seed, 0.25, 0.1), "power", cases).n for seed in range(200)])
    assert mean(None) == pytest.approx(N, abs=0.5 * abs(N))
    assert mean(None) > 0.8 * N
    assert mean(NAMES) == pytest.approx(N, abs=0.13 * abs(N))


def test_lines_of_groups_share_their_slope():
    """Two groups, of which the second lies higher and at larger x: a common line would be much steeper."""
    x = np.array([1.0, 2, 3, 4, 5, 6])
    y = 0.5 * x + np.repeat([1.0, 11.0], 3)
    law = fit(x, y, "line", groups=np.repeat(["a", "b"], 3))
    assert law.n == pytest.approx(0.5, abs=1e-12)
    assert law(2.0) == pytest.approx(2, abs=1e-12)
    assert law(5.0, group=1) == pytest.approx(13.5, abs=1e-12)
    assert law(5.0, n=0.0, group=1) == pytest.approx(13.5, abs=1e-12)
    assert fit(x, y, "line").n > 2


def test_least_squares_are_those_of_numpy():
    """Each run its own case: the usual line with its usual error."""
    x, y = (np.log(values) for values in ensemble(1, 0.05, 0.15))
    (slope, intercept), covariance = np.polyfit(x, y, 1, cov=True)
    law = fit(x, y, "line")
    assert law.n == pytest.approx(slope, rel=1e-9)
    assert law.a == pytest.approx(intercept, rel=1e-9)
    assert law.error == pytest.approx(np.sqrt(covariance[0, 0]), rel=1e-9)


def test_where_a_line_is_zero_and_how_well_that_is_known():
    """y = 3 (x - 2) with scatter: the spread of the zeros of many fits is their standard error."""
    random, x = np.random.default_rng(5), np.repeat([4.0, 6.0, 9.0], 4)
    found = [fit(x, 3 * (x - 2) + 0.3 * random.standard_normal(len(x)), "line").zero for _ in range(2000)]
    zeros, errors = np.transpose(found)
    assert zeros.mean() == pytest.approx(2, abs=0.01)
    assert errors.mean() == pytest.approx(zeros.std(), rel=0.05)


def test_a_ratio_is_that_of_the_means():
    x, y = np.array([1.0, 2, 3, 4]), np.array([0.9, 2.2, 2.9, 4.4])
    law = fit(x, y, "ratio")
    assert law.n == pytest.approx(10.4 / 10, rel=1e-12)
    assert law.error == pytest.approx(np.std(y - law.n * x, ddof=1) * 2 / 10, rel=1e-9)
    assert law(2.0) == pytest.approx(2.08, rel=1e-12)


def test_what_makes_no_law():
    one = np.full(3, 1e-2)
    assert fit(one, np.array([1.0, 2, 3]), "line") is None, "one length"
    assert fit(np.array([1e-2, 1.1e-2, 0.9e-2]), one, "line", ["a", "a", "a"]) is None, "one case"
    assert fit(np.array([1.0, 2]), np.array([1.0, 2]), "power") is None, "two runs"
    assert fit(np.array([]), np.array([]), "ratio") is None
    assert fit(np.array([1.0, 2, 3, 4]), np.array([1.0, 2, np.nan, np.nan]), "line") is None, "two runs with numbers"


def test_a_power_leaves_out_what_is_not_positive():
    law = fit(np.array([1.0, 2, 4, 8]), np.array([1.0, 2, -1, 8]), "power")
    assert law.n == pytest.approx(1, abs=1e-12)
    assert (law.runs, law.known) == (3, 4)
