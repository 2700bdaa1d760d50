"""Frequency and damping from a free response: matrix pencil (a Prony method) and, as a check, the moving block.

Signals may be complex: for the multiblade coordinates z = cosine + i sine a positive frequency is a progressive whirl (in the
sense of rotation, seen in the non-rotating frame), a negative one a regressive whirl.
"""
import dataclasses

import numpy as np
from scipy import linalg, signal as sps


@dataclasses.dataclass
class Mode:
    frequency: float   # [rad/s] signed for complex signals
    growth: float      # [1/s] real part of the eigenvalue; negative: damped
    amplitude: float   # at the start of the record, in the unit of the signal

    @property
    def damping_ratio(self):
        """[-] share of critical damping; positive: damped."""
        return -self.growth / np.hypot(self.growth, self.frequency)


def decimated(signal, dt, highest):
    """Signal and sampling time after low-pass filtering (zero phase) such that `highest` [rad/s] is kept with a margin."""
    factor = int(np.pi / dt / (4.0 * highest))
    if factor < 2:
        return signal, dt
    # An FIR filter of unit gain is flat in the pass band; the ends it disturbs are cut off by the caller's margins.
    taps = sps.firwin(12 * factor + 1, 1.0 / factor, window=("kaiser", 8.0))
    return np.convolve(signal, taps, mode="valid")[::factor], dt * factor


def matrix_pencil(signal, dt, noise=1e-3, most=12):
    """Modes of signal = sum amplitude exp((growth + i frequency) t), equally spaced by dt [s], strongest first.

    Hua and Sarkar 1990. noise: singular values below this share of the largest are taken for noise. A constant part comes out
    as a mode of frequency 0. A real signal's conjugate pair is returned once, with positive frequency and the whole amplitude.
    """
    n = len(signal)
    pencil = n // 2
    hankel = linalg.hankel(signal[: n - pencil], signal[n - pencil - 1:])
    _, singular, right = linalg.svd(hankel, full_matrices=False)
    if singular[0] == 0.0:
        return []
    order = int(min(most, np.count_nonzero(singular > noise * singular[0])))
    basis = right[:order].conj().T   # (pencil + 1, order)
    # Columns of the Hankel matrix are spanned by powers of the poles; conjugated because right vectors are row vectors.
    poles = np.conj(linalg.eigvals(linalg.lstsq(basis[:-1], basis[1:])[0]))
    poles = poles[np.abs(poles) > 1e-6]
    vandermonde = poles[None, :] ** np.arange(n)[:, None]
    amplitudes = linalg.lstsq(vandermonde, signal.astype(complex))[0]
    real = not np.iscomplexobj(signal)
    modes = []
    for pole, amplitude in zip(np.log(poles) / dt, amplitudes):
        oscillates = abs(pole.imag) * dt > 1e-9
        if real and oscillates and pole.imag < 0:
            continue
        modes.append(Mode(pole.imag, pole.real, abs(amplitude) * (2.0 if real and oscillates else 1.0)))
    return sorted(modes, key=lambda mode: -mode.amplitude)


@dataclasses.dataclass
class MovingBlock:
    time: np.ndarray        # [s] centre of each block, from the start of the record
    logarithm: np.ndarray   # natural logarithm of the amplitude
    growth: float           # [1/s] slope of the straight line through them
    offset: float           # its value at time 0
    scatter: float          # root mean square distance from the line


def moving_block(signal, dt, frequency, share=0.5):
    """Growth of the component at `frequency` [rad/s]: amplitude within a block that slides over the record (its length: `share`
    of the record, whole periods), by a windowed Fourier sum, against time. None for less than two periods per block."""
    n = len(signal)
    period = 2 * np.pi / abs(frequency) / dt
    block = int(np.floor(share * n / period) * period)
    if block < 2 * period:
        return None
    time = np.arange(n) * dt
    window = sps.windows.hann(block, sym=False)
    window /= window.sum()
    turned = signal * np.exp(-1j * frequency * time)
    amplitude = np.abs(sps.fftconvolve(turned, window, mode="valid"))
    centre = time[: len(amplitude)] + 0.5 * block * dt
    if np.any(amplitude <= 0.0):
        return None
    logarithm = np.log(amplitude * (1.0 if np.iscomplexobj(signal) else 2.0))
    growth, offset = np.polyfit(centre, logarithm, 1)
    return MovingBlock(centre, logarithm, growth, offset, float(np.std(logarithm - growth * centre - offset)))
