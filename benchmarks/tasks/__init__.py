"""Twenty tasks in words, each with what its answer must satisfy: an evaluation of anyone who answers them."""
