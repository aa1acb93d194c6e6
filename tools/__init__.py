"""Makes the files of the repository that are generated from others."""
