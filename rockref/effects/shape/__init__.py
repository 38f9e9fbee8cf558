"""What the block is: contact points, centre of mass, inertia, sides."""
