"""The ROM of the PMC006B4's planner (`make rom`)."""
