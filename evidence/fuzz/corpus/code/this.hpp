struct a { a() { (*this)[0] = static_cast<T>(1) / static_cast<T>(2); (*this)[1] = (*this)[0]; } };
