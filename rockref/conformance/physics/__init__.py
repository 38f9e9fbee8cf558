"""A profile for physics engines with a contact law of their own: does a block rock as mechanics says?

The vectors of `rockref.conformance` judge the law of the source, number by number. This profile asks what every rigid
body on a plate has to do, whatever its contact is made of: closed forms and the theory of the rocking block.
"""
