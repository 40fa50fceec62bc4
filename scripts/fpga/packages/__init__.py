"""`make packages`: everything that hands the RTL to other tools, made from rtl/files.yml."""
