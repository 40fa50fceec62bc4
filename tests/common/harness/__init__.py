"""Tests of the simulator harness, of the scripts of make targets, and of the pages that scripts write."""
