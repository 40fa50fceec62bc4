"""Programs of the make targets: `python -m scripts.<folder>.<name>` from the project's root.

fpga, demo, site, release: what users get. pages: what is drawn into docs/. measure: checks and measurements.
targets, run, env: the table of targets, and what make starts. Imports run release → site → demo → fpga,
measure → demo and pages → measure.
"""
