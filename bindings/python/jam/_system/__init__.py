"""The parts that a System is made of."""
