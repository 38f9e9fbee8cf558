"""The page that holds everything: pieces, curves that can be zoomed, the player, its scripts and style."""
