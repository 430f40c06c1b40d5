display: Ring
description: Rings the bell of the cart
platform: cafe_cart
interface: cafe_cart/ring.interface
launch: cafe_cart/ring.launch
