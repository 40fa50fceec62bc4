"""Checks and measurements of the project: lint, trace, proofs, mutants, coverage, sizes, speed."""
