"""Programs that make targets start: `python -m scripts.<folder>.<name>` from the project's root.

fpga, demo, site and release make products for users. pages makes the pictures and tables of docs/. measure
checks and measures the project. targets is the table of targets; make starts run and env.

Permitted imports: release → site → demo → fpga, measure → demo, pages → measure.
"""
