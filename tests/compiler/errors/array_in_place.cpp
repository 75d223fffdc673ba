void array_in_place(int values[64]) {
  for (int i = 0; i < 63; ++i)
    if (values[i] > values[i + 1]) {  // refused: array 'values'.*read here before it is written.*array of their own
      const int first = values[i];
      values[i] = values[i + 1];
      values[i + 1] = first;
    }
}
