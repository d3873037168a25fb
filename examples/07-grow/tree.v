/* Drawing of tree.l: colour 1 is wood, 2 leaves. Shoots turn up as they grow. */
angle increment: 30
initial line width: 0.2
initial color: 1
contour sides: 8
surface: l leaf.s 1 3 5
tropism: T: 0 1 0 E: 0.03
