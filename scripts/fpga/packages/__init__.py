"""`make packages`: the files that describe the RTL to other tools, generated from rtl/files.yml."""
