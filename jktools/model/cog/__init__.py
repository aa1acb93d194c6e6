"""What a script means: verbs, messages, values, and the names that it binds."""
