"""Programs of the make targets: `python -m scripts.<folder>.<name>` from the project's root.

fpga, demo, site, release: products for users. pages: pictures and tables of docs/. measure: checks and
measurements. targets, run, env: the table of targets, and the modules that make starts. Permitted imports:
release → site → demo → fpga, measure → demo, pages → measure.
"""
