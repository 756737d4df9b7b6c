"""What kaidan can do, one module a verb, each on the questions and answers below it."""
