// The question of a prediction as a widget of Jupyter; what answers it is a widget of its own, which the kernel puts below.

import { askForPrediction } from "./lessons/predicting.js";

export default { render: askForPrediction };
