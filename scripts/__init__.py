"""Programs that make targets start: `python -m scripts.<folder>.<name>` from the project's root.

fpga, demo, site and release make products for users, pages makes pictures and tables of docs/, measure checks
and measures the project. The module targets is the table of make targets; make starts run and env.

Permitted imports (→ = "may import"): release → site → demo → fpga, measure → demo, pages → measure.
"""
