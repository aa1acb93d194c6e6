"""What can be known about a script: its flow, its values, how often its handlers run."""
