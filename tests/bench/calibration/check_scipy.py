#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""check_scipy.py BENCH_CALIBRATION: the statistics agree with scipy's on the same values. Skipped without scipy (77)."""
import subprocess
import sys

try:
    import numpy as np
    from scipy import stats
except ImportError:
    sys.exit(77)

differences = np.array([1.5, -0.4, 2.25, 0.75, -1.0, 3.0, 0.1, 1.25, -0.2, 2.0, 0.6, -1.75])
y = np.array([3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8])
lines = subprocess.run([sys.argv[1], "--examples"], check=True, capture_output=True, text=True).stdout.split("\n")
ours = {name: float(value) for name, value in (line.split() for line in lines if line)}

padded = np.append(differences, [4.0, -4.0])
permuted = stats.permutation_test((y,), lambda one: stats.spearmanr(differences, one)[0],
                                  permutation_type="pairings", n_resamples=5000, random_state=1)
walsh = [(a + b) / 2 for i, a in enumerate(differences) for b in differences[i:]]
exact = stats.binomtest(9, 12).proportion_ci(0.95)
# a value of scipy's, and how far ours may be from it
expected = {"signed_rank_p": (stats.wilcoxon(differences, mode="exact").pvalue, 1e-9),
            "padded_mean_p": (stats.ttest_1samp(padded, 0.0).pvalue, 1e-9),
            "hodges_lehmann": (np.median(walsh), 1e-9),
            "spearman_rho": (stats.spearmanr(differences, y)[0], 1e-9),
            "spearman_p": (permuted.pvalue, 0.03),  # both drawn
            "student_975_of_12": (stats.t.ppf(0.975, 11), 1e-9)}
wrong = [f"{name}: {ours[name]}, scipy {value}" for name, (value, most) in expected.items()
         if not abs(ours[name] - value) <= most]
# valid for all distributions, so no nearer than the exact interval of this one, and not much farther
if not exact.low - 0.12 < ours["betting_low"] <= exact.low or not exact.high <= ours["betting_high"] < exact.high + 0.12:
    wrong.append(f"betting: [{ours['betting_low']}, {ours['betting_high']}], exact {exact}")
print("\n".join(wrong) or f"{len(expected) + 1} statistics agree")
sys.exit(1 if wrong else 0)
