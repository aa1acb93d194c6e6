"""The files that a level refers to: models, materials, sprites and the like, read as the engine reads them."""
