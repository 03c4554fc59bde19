"""Course mode: variants of a task, answer keys with the usual mistakes, questions for learning platforms, grading."""
