# SPDX-License-Identifier: Apache-2.0
"""Bytes of frames as videos: AV1 by libaom and HEVC by x265, for sequence.py. Frames are arrays of
height x width x 3 samples of 8 bits."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np


def write_y4m(frames, path):
    """8 bits, 4:4:4, BT.709 in full range."""
    height, width, _ = frames[0].shape
    with open(path, "wb") as out:
        out.write(f"YUV4MPEG2 W{width} H{height} F25:1 Ip A1:1 C444 XCOLORRANGE=FULL\n".encode())
        for frame in frames:
            r, g, b = np.moveaxis(frame.astype(np.float64), 2, 0)
            y = 0.2126 * r + 0.7152 * g + 0.0722 * b
            planes = [y, (b - y) / 1.8556 + 128, (r - y) / 1.5748 + 128]
            out.write(b"FRAME\n")
            for plane in planes:
                out.write(np.clip(np.rint(plane), 0, 255).astype(np.uint8).tobytes())


def psnr_of_video(planes_file, frames):
    """Of all samples of the frames, in RGB."""
    height, width, _ = frames[0].shape
    raw = Path(planes_file).read_bytes()
    planes = np.frombuffer(raw, np.uint8).reshape(len(frames), 3, height, width).astype(np.float64)
    squares = 0.0
    for (y, u, v), frame in zip(planes, frames):
        b, r = y + 1.8556 * (u - 128), y + 1.5748 * (v - 128)
        g = (y - 0.2126 * r - 0.0722 * b) / 0.7152
        shown = np.clip(np.rint(np.stack([r, g, b], axis=2)), 0, 255)
        squares += np.sum((shown - frame) ** 2)
    return 10 * np.log10(255**2 / (squares / (len(frames) * height * width * 3)))


def av1(frames, group=0):
    """(PSNR, bytes) of libaom at several qualities: of key frames alone, or of groups."""
    curve = []
    with tempfile.TemporaryDirectory() as out:
        write_y4m(frames, out + "/in.y4m")
        for level in (20, 28, 36, 44, 52, 60):
            subprocess.run(
                ["aomenc", "--obu", "--i444", "--end-usage=q", f"--cq-level={level}",
                 "--cpu-used=3", "--passes=2", f"--kf-max-dist={group}", "-o", out + "/v.obu",
                 out + "/in.y4m"], check=True, capture_output=True)
            subprocess.run(
                ["aomdec", "--rawvideo", "-o", out + "/v.yuv", out + "/v.obu"], check=True)
            size = Path(out + "/v.obu").stat().st_size
            curve.append((psnr_of_video(out + "/v.yuv", frames), size))
    return sorted(curve)


def hevc(frames, group):
    """(PSNR, bytes) of x265 in groups at several qualities."""
    curve = []
    with tempfile.TemporaryDirectory() as out:
        write_y4m(frames, out + "/in.y4m")
        for quality in (14, 20, 26, 32, 38, 44):
            subprocess.run(
                ["x265", "--preset", "slow", "--tune", "psnr", "--crf", str(quality), "--keyint",
                 str(group), "--no-info", "--range", "full", "--colormatrix", "bt709", "--recon",
                 out + "/v.yuv", "-o", out + "/v.hevc", out + "/in.y4m"],
                check=True, capture_output=True)
            size = Path(out + "/v.hevc").stat().st_size
            curve.append((psnr_of_video(out + "/v.yuv", frames), size))
    return sorted(curve)
