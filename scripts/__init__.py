"""Scripts behind the Makefile targets; run them as ``python -m scripts.<name>`` from the project's root."""
