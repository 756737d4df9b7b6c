"""The paper again: what it prints, what kaidan computes, its figures."""
