"""Studies of the models themselves: the paper reproduced, physics calibrated, models compared."""
