    distance = error(‹h›, ‹count›, [‹end_q›], [‹end_p›])
    agreement = "the bits of Shadowstep" if distance == 0 else f"{distance:.1e} from Shadowstep"
    print(f"‹name›: ‹count› steps of ‹part›: {agreement}")
    passed = distance < ‹tolerance›
‹if order_shows›

    exact = [‹exact_q›], [‹exact_p›]  # at t = ‹time›
    order = ‹numpy›.log2(error(‹time› / ‹coarse›, ‹coarse›, *exact) / error(‹time› / ‹fine›, ‹fine›, *exact))
    print(f"‹name›: order {order:.2f} observed, ‹order› proved")
    passed = passed and order > ‹order› - 0.5
‹end›
    return passed


if __name__ == "__main__":
    raise SystemExit(0 if self_test() else "‹name›: the self-test has failed")
