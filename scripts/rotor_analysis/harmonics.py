"""Harmonics per revolution: resampled over azimuth, so that a varying rotor speed smears nothing."""
import dataclasses

import numpy as np
from scipy.interpolate import CubicSpline


@dataclasses.dataclass
class Harmonics:
    """amplitude (kmax+1, columns): of k cycles per revolution, k = 0 being the mean; in the unit of the signal.
    residual (columns,): root mean square of what these harmonics leave over: transients, free vibration, higher ones."""
    amplitude: np.ndarray
    residual: np.ndarray
    revolutions: int


def per_revolution(azimuth, signals, highest=12, most_revolutions=20):
    """Harmonics of the columns of `signals` (n, columns) over the last whole revolutions of `azimuth` (n,) [rad, unwrapped].

    From four revolutions on a Hann window keeps transients and free vibration out of the harmonics, which it leaves exact.
    None when there is less than one revolution, when the azimuth does not increase, or fewer than four samples per
    revolution."""
    if len(azimuth) < 4 or np.any(np.diff(azimuth) <= 0):
        return None
    turns = (azimuth[-1] - azimuth[0]) / (2 * np.pi)
    revolutions = min(int(np.floor(turns + 1e-9)), most_revolutions)
    per_turn = (len(azimuth) - 1) / turns if turns > 0 else 0
    if revolutions < 1 or per_turn < 4:
        return None
    highest = min(highest, int(per_turn / 2 - 1e-9))
    points = max(64, 4 * int(np.ceil(per_turn))) * revolutions
    begin = azimuth[-1] - 2 * np.pi * revolutions
    grid = np.maximum(begin + np.arange(points) * (2 * np.pi * revolutions / points), azimuth[0])
    resampled = CubicSpline(azimuth, signals)(grid)

    phase = 2 * np.pi * np.arange(points) / points
    weights = (1.0 - np.cos(phase) if revolutions >= 4 else np.ones(points))[:, None] / points
    mean = np.sum(weights * resampled, axis=0)
    # Phase counts from the first point, which does not matter for amplitudes; bin k * revolutions is k per revolution.
    spectrum = np.fft.rfft(weights * (resampled - mean), axis=0)
    amplitude = 2 * np.abs(spectrum[np.arange(highest + 1) * revolutions])
    amplitude[0] = mean
    variance = np.sum(weights * (resampled - mean) ** 2, axis=0)
    residual = np.sqrt(np.maximum(variance - 0.5 * np.sum(amplitude[1:] ** 2, axis=0), 0.0))
    return Harmonics(amplitude, residual, revolutions)
