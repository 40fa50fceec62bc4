"""The pictures and generated tables of docs/: timing diagrams (WaveDrom), plots (matplotlib), tables."""
