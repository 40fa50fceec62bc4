"""Tests of the command line, except the commands of single devices."""
