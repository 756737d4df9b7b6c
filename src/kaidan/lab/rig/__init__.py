"""The paper's experiment on a real robot: which trials to make, a sheet to fill in, and the fit."""
